# Sourced by what drives nacre's window under Xvfb with xdotool. $nacre is the program, $work a folder to write to.

# Exit code 77, which CTest counts as skipped, where the tools are missing.
require_window_tools() { # [FURTHER TOOLS]
    for tool in Xvfb xdotool import compare "$@"; do
        command -v "$tool" >/dev/null || { echo "needs $tool (apt.txt)"; exit 77; }
    done
}

# What a script of the documents needs: the program, a folder of its own, a surface, a display.
set_stage() { # NACRE
    nacre=$(realpath "$1")
    work=$(mktemp -d)
    shots=$work/shots
    require_window_tools
    mkdir -p "$shots"
    make_scene
    start_display 1280x720
}

start_display() { # SIZE such as 1280x720
    mkdir -p "$work"
    rm -f "$work/display"
    Xvfb -noreset -displayfd 3 -screen 0 "$1x24" 3>"$work/display" >/dev/null 2>&1 &
    xvfb_id=$!
    trap stop_display EXIT
    for _ in $(seq 100); do [ -s "$work/display" ] && break; sleep 0.1; done
    export DISPLAY=":$(cat "$work/display")"
}

stop_display() {
    [ -n "${window_id:-}" ] && kill "$window_id" 2>/dev/null
    [ -n "${xvfb_id:-}" ] && kill "$xvfb_id" 2>/dev/null
    window_id= xvfb_id=
}

# A capture, the surface measured from it, and a second shape, made once.
make_scene() {
    [ -d "$work/bumpy.nacre" ] && return
    "$nacre" synth "$work/capture" --quiet --force --lights 12 --side 320 --give-lights \
        --material 'ggx:diffuse=0.5,0.2,0.1;specular=0.05;alpha=0.15'
    "$nacre" acquire "$work/capture" -o "$work/bumpy.nacre" --quiet --force --normals consensus
}

open_window() { # ARGUMENTS of nacre view; waits until it has drawn
    export XDG_STATE_HOME=$work/state # not the user's own
    shot_count=$(find "$shots" -name '*.png' | wc -l)
    "$nacre" view "$@" --screenshots "$shots" >"$work/out" 2>"$work/err" &
    window_id=$!
    for _ in $(seq 300); do
        x_window=$(xdotool search --name ' ms a frame$' 2>/dev/null | head -n 1) && [ -n "$x_window" ] && break
        kill -0 "$window_id" 2>/dev/null || { cat "$work/err"; return 1; }
        sleep 0.05
    done
    xdotool windowfocus --sync "$x_window" mousemove 640 340
    sleep 0.5
}

# The window takes keys in the order in which they come, so that nothing has to be waited for between them.
press() { xdotool key "$@"; }

# Waits for the picture and the state that a key has asked for, and leaves the picture's name in $shot.
wait_for_screenshot() {
    shot_count=$((shot_count + 1))
    shot=$(printf '%s/nacre-%04d.png' "$shots" "$shot_count")
    for _ in $(seq 500); do
        [ -e "${shot%.png}.json" ] && return # written last
        sleep 0.02
    done
    echo "no $shot"; cat "$work/err"
    return 1
}
screenshot() { press F12; wait_for_screenshot; }

drag() { # BUTTON X Y X Y ...: pressed at the first place, released at the last
    local button=$1
    shift
    xdotool mousemove "$1" "$2" mousedown "$button"
    shift 2
    while [ $# -gt 0 ]; do xdotool mousemove "$1" "$2"; sleep 0.05; shift 2; done
    xdotool mouseup "$button"
    sleep 0.1
}
