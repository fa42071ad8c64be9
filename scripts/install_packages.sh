# Sourced by demo.sh and test.sh: makes sure that what apt.txt lists is installed, without the tests' part for `program_only=1`.
packages=$(sed -e "${program_only:+/^# Tests/,\$d}" -e 's/#.*//' -e 's/[[:space:]].*//' apt.txt | grep -v '^$')
missing=
if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
    installed=$(dpkg-query -W -f '${Package} ${Status}\n' $packages 2>/dev/null | sed -n 's/ .* ok installed$//p') || true
    for package in $packages; do
        grep -qxF "$package" <<<"$installed" || missing="$missing $package"
    done
else
    echo "No apt here: it is taken for granted that this system has what apt.txt lists" >&2
fi
if [ -n "$missing" ]; then
    sudo=
    if [ "$(id -u)" != 0 ]; then
        sudo=sudo
        if ! command -v sudo >/dev/null; then
            echo "Missing packages, and no sudo to install them:$missing" >&2
            exit 3
        fi
    fi
    echo "Installing:$missing"
    log=$(mktemp)
    # sudo drops the environment, hence env.
    if ! { $sudo apt-get update -qq &&
        $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing; } >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        echo "Could not install:$missing" >&2
        exit 3
    fi
    rm -f "$log"
fi
