#!/usr/bin/env bash
# Builds what a sanitizer looks at (clang) and runs it; fails at the first report.
#   tests/sanitizers.sh asan|tsan [whole]
# asan: address and undefined behaviour; unit tests, what the fuzzers have kept, a short run of every test, a series and a
#   scene, some closed forms.
# tsan: data races between threads; the same runs.
# whole: unit and verification tests as well, an hour and more.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in
asan) preset=asan-ubsan tests="test_unit fuzz_replay" labels=unit threads=1 jobs=2 ;;
tsan) preset=tsan tests="" labels="" threads=2 jobs=1 ;;
*) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac
if [ "${2:-}" = whole ]; then
    tests="test_unit fuzz_replay test_verification"
    labels='unit|verification'
fi
build=build/$preset
cmake --preset "$preset" >/dev/null
# shellcheck disable=SC2086
ninja -C "$build" proveta $tests

export OMP_NUM_THREADS=$threads # tests side by side want no more than one, races no fewer than two
# OpenMP's runtime is not compiled for the thread sanitizer. Its tool Archer, which it loads by itself where it finds the sanitizer, tells of
# its barriers; what the sanitizer sees inside the runtime is to be left out. With both, loops without races are silent and races are not;
# without either there are false alarms. The team of core/parallel has threads of its own, which need no help.
export TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1
export LSAN_OPTIONS=suppressions=$PWD/tests/fuzz/leaks.txt:print_suppressions=0

# A deck that is over after a few hundred steps.
write_deck() {
    local specimen='"diameter": "50 mm", "height": "100 mm", "spheres": 300'
    local loading='"rate": "1 m/s", "stop": {"axial_strain": 0.002}'
    case $1 in
    brazilian) specimen='"shape": "disc", "diameter": "50 mm", "height": "30 mm", "spheres": 300' ;;
    triaxial) loading="\"confining_pressure\": [\"1 MPa\", \"2 MPa\"], $loading" ;; # a series of two
    hydrostatic) loading='"pressure": "5 MPa"' ;;
    granular-triaxial)
        loading="\"ramp\": \"1 ms\", \"membrane\": {\"element\": \"30 mm\"}, $loading"
        specimen='"diameter": "100 mm", "height": "150 mm", "particles": {"form": "stone", "size": "34 mm", "spheres": 5, "forms": 2}'
        ;;
    esac
    echo "{\"test\": \"$1\", \"specimen\": {$specimen}, \"loading\": {$loading},
           \"output\": {\"samples\": 10, \"fields\": 1, \"pictures\": 200}}"
}

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
for test in ucs brazilian direct-tension triaxial hydrostatic oedometric granular-triaxial; do
    echo "$test"
    write_deck $test >"$out"/$test.json
    "$build"/proveta run "$out"/$test.json --threads 2 --quiet --out "$out"/$test >/dev/null
done
echo "scene"
"$build"/proveta scene examples/silo.json --set stop.time=0.02 --threads 2 --quiet --out "$out"/silo >/dev/null
echo "closed forms"
"$build"/proveta verify dempack-bond facet-bond two-body-energy regular-lattice facet-edge-vertex multi-contact rolling-resistance \
    weak-equals-none bonded-cantilever >/dev/null
[ -z "$labels" ] || ctest --test-dir "$build" --output-on-failure -j $jobs -L "$labels" -LE long
