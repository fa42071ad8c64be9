# Sourced by demo.sh and test.sh: makes sure that what apt.txt lists is installed.
packages=$(sed -e 's/#.*//' -e 's/[[:space:]].*//' apt.txt | grep -v '^$')
missing=
for package in $packages; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
if [ -n "$missing" ]; then
    sudo=
    [ "$(id -u)" = 0 ] || sudo=sudo
    if [ -n "$sudo" ] && ! command -v sudo >/dev/null; then
        echo "Missing packages, and no sudo to install them:$missing" >&2
        exit 3
    fi
    echo "Installing:$missing"
    if ! { $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends $missing; } >install.log 2>&1; then
        tail -n 20 install.log >&2
        echo "Could not install:$missing" >&2
        exit 3
    fi
    rm -f install.log
fi
