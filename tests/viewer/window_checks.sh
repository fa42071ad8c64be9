# Sourced by the tests of the window after scripts/window_driver.sh: checks on screenshots, their states and the screen.

failures=0
later=() # checks that run beside the driving, each with a folder of its own

report() { # CODE NAME
    if [ "$1" = 0 ]; then echo "ok    $2"; else echo "FAIL  $2"; failures=$((failures + 1)); fi
}
check() { # NAME COMMAND...
    local name=$1 code=0
    shift
    "$@" || code=$?
    report "$code" "$name"
}
# The same for what needs no window, in the background; finish_checks waits for it.
check_later() { # NAME COMMAND...
    local folder
    folder=$(mktemp -d -p "$work")
    echo "$1" >"$folder/name"
    shift
    (cd "$folder"; code=0; "$@" >log 2>&1 || code=$?; echo "$code" >code) &
    later+=("$! $folder")
}
finish_checks() {
    local job
    for job in "${later[@]}"; do
        wait "${job%% *}" || true
        local folder=${job#* }
        [ "$(cat "$folder/code")" = 0 ] || cat "$folder/log"
        report "$(cat "$folder/code")" "$(cat "$folder/name")"
        rm -r "$folder"
    done
    later=()
}

state_of() { echo "${1%.png}.json"; }
holds() { grep -qF -- "$2" "$(state_of "$1")"; }
lacks() { ! holds "$@"; }
differs_in_light() { ! diff -q <(grep -A3 '"light"' "$(state_of "$1")") <(grep -A3 '"light"' "$(state_of "$2")") >/dev/null; }
differs() { ! cmp -s "$1" "$2"; }
# The screen of 1280x720 without its status line, whose words come and go by themselves.
grab() { import -window root -crop 1280x694+0+0 +repage "$work/$1.png"; }
# Waits until the screen is another than BEFORE.png, and keeps it as AFTER.png.
changes() { # BEFORE AFTER SECONDS
    for _ in $(seq $((10 * $3))); do
        sleep 0.05
        grab "$2"
        cmp -s "$work/$1.png" "$work/$2.png" || return 0
    done
    return 1
}
# Waits until two looks in a row are the same, and keeps the screen as NAME.png.
settles() { # NAME
    grab "$1"
    for _ in $(seq 100); do
        cp "$work/$1.png" "$work/look.png"
        sleep 0.1
        grab "$1"
        cmp -s "$work/look.png" "$work/$1.png" && return
    done
    return 1
}
# Waits until the screen is BEFORE.png again; keeps the last look as AFTER.png.
returns_to() { # BEFORE AFTER SECONDS
    for _ in $(seq $((10 * $3))); do
        grab "$2"
        cmp -s "$work/$1.png" "$work/$2.png" && return
        sleep 0.05
    done
    return 1
}
# The same state without a window: the picture and its metadata byte for byte.
reproduces_itself() { # SCREENSHOT [ARGUMENTS of nacre view]
    local again
    again=$(mktemp -u -p "$(dirname "$1")" .again-XXXXXX) # beside it: paths in states are relative to them
    "$nacre" view --state "$(state_of "$1")" "${@:2}" --headless -o "$again.png"
    local same=0
    cmp "$1" "$again.png" && cmp "$(state_of "$1")" "$again.json" || same=1
    rm -f "$again.png" "$again.json"
    return "$same"
}
# And what nacre render makes of it, pixel for pixel.
reproduces() { # SCREENSHOT
    reproduces_itself "$1"
    "$nacre" render --state "$(state_of "$1")" -o render.png --quiet
    [ "$(compare -metric AE "$1" render.png null: 2>&1)" = 0 ]
}
# The program does not do it, and names WORD as what it would need.
refuses() { # WORD ARGUMENTS
    local code=0
    "$nacre" "${@:2}" 2>refused || code=$?
    [ "$code" = 2 ] && grep -qF -- "$1" refused
}
# Waits until a part of the screen is a picture: no 8-bit code off by more than one.
screen_shows() { # PICTURE WxH+X+Y
    local off
    for _ in $(seq 20); do
        import -window root -crop "$2" +repage "$work/screen.png"
        off=$(compare -metric PAE "$work/screen.png" "$1" null: 2>&1 || true)
        awk -v text="$off" 'BEGIN { gsub(/[()]/, "", text); split(text, part, " "); exit !(part[2] * 255 <= 1.01) }' &&
            return
        sleep 0.1
    done
    echo "      largest difference of the screen: $off"
    return 1
}
# Closes the window by its key, which must end the program well and without a message.
quits_quietly() {
    local code=0
    press Escape
    wait "$window_id" || code=$?
    window_id=
    cat "$work/err"
    [ "$code" = 0 ] && [ ! -s "$work/err" ]
}
