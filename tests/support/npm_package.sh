# Sourced: npm_package PACKAGE SOURCES FOLDER installs an npm package into FOLDER once, by package.json and the lock file in
# SOURCES. Exits with 77, which skips a test: no node and npm here, or no registry.
npm_package() {
    local package=$1 sources=$2 folder=$3
    if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
        echo "needs node and npm (Debian packages nodejs, npm)"
        exit 77
    fi
    mkdir -p "$folder"
    cp "$sources/package.json" "$sources/package-lock.json" "$folder"
    if ! [ -d "$folder/node_modules/$package" ] &&
        ! npm ci --prefix "$folder" --no-audit --no-fund --ignore-scripts --omit=peer --fetch-retries 0 --fetch-timeout 20000 \
            >"$folder/npm.log" 2>&1; then
        echo "needs the npm registry for $package:"
        tail -n 3 "$folder/npm.log"
        exit 77
    fi
}
