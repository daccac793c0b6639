#!/usr/bin/env bash
# Sets up Proveta on a fresh Debian 12 machine and does the main job.
#   ./bootstrap.sh run    install, build, run examples/ucs.json into results/ucs
#   ./bootstrap.sh test   install, build, run the tests (unit, verification, system)
#   ./bootstrap.sh build  install and build only
#   ./bootstrap.sh docs   install, build, make the documentation as a site: build/site/index.html
set -euo pipefail
cd "$(dirname "$0")"
build=build/release
node_tools=build/node

install_packages() {
    local wanted missing=()
    wanted=$(grep -v '^#' packages.txt)
    for package in $wanted; do
        # A package counts as there when it is installed, or when what it is wanted for works already.
        case $package in nodejs) command -v node >/dev/null && continue ;; npm) command -v npm >/dev/null && continue ;; esac
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    echo "installing: ${missing[*]}"
    local sudo=""
    [ "$(id -u)" -eq 0 ] || sudo=sudo
    $sudo apt-get update -qq
    DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

build_program() {
    # As many compilers at once as there are processors, but two gigabytes must be free for each.
    local jobs
    jobs=$(awk -v n="$(nproc)" '/MemAvailable/ {m = int($2 / 2097152); print m < 1 ? 1 : m < n ? m : n}' /proc/meminfo)
    cmake --preset release >/dev/null
    cmake --build --preset release -j "$jobs"
}

case "${1:-}" in
build)
    install_packages
    build_program
    ;;
run)
    install_packages
    build_program
    "$build/proveta" run examples/ucs.json --out results/ucs
    ;;
test)
    install_packages
    build_program
    # The schema test wants a JSON schema validator, the test of the pages what drives a browser.
    for tool in ajv@8 playwright-core@1; do
        [ -d "$node_tools/node_modules/${tool%@*}" ] || npm install --silent --no-audit --no-fund --prefix "$node_tools" "$tool" >/dev/null
    done
    # As many tests side by side as there are processors, each on one thread unless it asks for more: threads that wait for each other on
    # shared processors take more than twice as long.
    OMP_NUM_THREADS=1 PROVETA_NODE_MODULES="$PWD/$node_tools/node_modules" \
        ctest --preset release -L 'unit|verification|system' -j "$(nproc)"
    ;;
docs)
    install_packages
    build_program
    /usr/bin/python3 docs/site.py "$build/proveta" . build/site_pages
    mkdocs build --quiet --strict
    echo "the documentation is in build/site/index.html"
    ;;
*)
    sed -n '2,6s/^# \{0,1\}//p' "$0"
    exit 2
    ;;
esac
