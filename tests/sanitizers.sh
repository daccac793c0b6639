#!/usr/bin/env bash
# Builds what a sanitizer looks at and runs it: unit tests, the verification tests that take no minute under it, all kept files of the
# fuzzers, and a short run of every test and of a scene with two threads. Fails at the first report.
#   tests/sanitizers.sh [asan|tsan]     both where none is named
set -euo pipefail
cd "$(dirname "$0")/.."

check() {
    local preset=$1 build=build/$1 out skip
    cmake --preset "$preset" >/dev/null
    ninja -C "$build" test_unit test_verification fuzz_replay proveta
    export OMP_NUM_THREADS=2
    # OpenMP's runtime is not compiled for the thread sanitizer. Its tool Archer, which it loads by itself where it finds the sanitizer, tells
    # of its barriers; what the sanitizer sees inside the runtime is to be left out. With both, loops without races are silent and races are
    # not; without either there are false alarms. The team of core/parallel has threads of its own, which need no help.
    export TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1
    export LSAN_OPTIONS=suppressions=$PWD/tests/fuzz/leaks.txt:print_suppressions=0
    # Closed forms that take thousands of steps: minutes each under a sanitizer, and the same code as in shorter ones.
    skip='long'
    ctest --test-dir "$build" --output-on-failure -j 2 -L 'unit|verification' -LE "$skip" --timeout 300
    out=$(mktemp -d)
    trap 'rm -rf "$out"' RETURN
    for test in ucs brazilian direct-tension triaxial hydrostatic oedometric granular-triaxial; do
        write_deck $test >"$out"/$test.json
        "$build"/proveta run "$out"/$test.json --threads 2 --quiet --out "$out"/$test
    done
    "$build"/proveta scene examples/silo.json --set stop.time=0.02 --threads 2 --quiet --out "$out"/silo
}

# A deck that is over after a few hundred steps.
write_deck() {
    local specimen='"diameter": "50 mm", "height": "100 mm", "spheres": 300'
    local loading='"rate": "1 m/s", "stop": {"axial_strain": 0.0005}'
    case $1 in
    brazilian) specimen='"diameter": "50 mm", "height": "30 mm", "spheres": 300' ;;
    hydrostatic) loading='"pressure": "5 MPa"' ;;
    granular-triaxial) specimen='"diameter": "300 mm", "height": "300 mm", "particles": {"size": "60 mm", "form": "sphere"}' ;;
    esac
    echo "{\"test\": \"$1\", \"specimen\": {$specimen}, \"loading\": {$loading},
           \"output\": {\"samples\": 10, \"fields\": 1}}"
}

case "${1:-both}" in
asan) check asan-ubsan ;;
tsan) check tsan ;;
both) check asan-ubsan && check tsan ;;
*) sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac
