#version 300 es
// The picture on the screen, right of the line another one; black around it.
precision highp float;
precision highp sampler2D;

uniform sampler2D first;
uniform sampler2D second;
uniform vec2 origin;     // of the picture's top left corner, in the screen's pixels from its top left
uniform float scale;     // screen pixels a picture pixel
uniform float screenHeight;
uniform bool isCompared; // there are two
uniform float line;      // between them, in screen pixels from the left

out vec4 code;

void main()
{
    vec2 place = vec2(gl_FragCoord.x, screenHeight - gl_FragCoord.y);
    vec2 at = (place - origin) / (scale * vec2(textureSize(first, 0)));
    bool isInside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)));
    // Read everywhere, since the mip level follows from the neighbours' places.
    vec3 shown = texture(first, at).rgb;
    if (isCompared) {
        vec3 other = texture(second, at).rgb;
        shown = place.x < line ? shown : other;
    }
    code = vec4(isInside ? shown : vec3(0.0), 1.0);
}
