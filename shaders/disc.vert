#version 460
// The disc that fills the target, a texel's width beyond its rim included, as a polygon of 16 sides in 14 triangles: a
// fifth of the square is never read.

const int kSides = 16;
const float kApothem = 1.01; // of the target's half width; balls that are shown are hundreds of texels across

void main()
{
    int corner = gl_VertexIndex % 3 == 0 ? 0 : gl_VertexIndex / 3 + gl_VertexIndex % 3;
    float step = 6.28318531 / float(kSides);
    float angle = step * float(corner);
    gl_Position = vec4(kApothem / cos(0.5 * step) * vec2(cos(angle), sin(angle)), 0.0, 1.0);
}
