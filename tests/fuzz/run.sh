#!/usr/bin/env bash
# Fuzzes each target (all, or those named) for so many seconds; fails when anything is found, which is then in build/fuzz/found/TARGET.
#   tests/fuzz/run.sh SECONDS [TARGET...]
# A finding that is understood goes to tests/fuzz/regressions/TARGET under a name that says what it shows, and its reader is mended.
# What it grows is in build/fuzz/corpus/TARGET; `run.sh --merge [TARGET...]` puts the fewest files that cover as much into build/fuzz/merged.
set -euo pipefail
cd "$(dirname "$0")/../.."
here=tests/fuzz
build=build/fuzz
all="deck card csv mesh surface hdf5"
# Leaks are looked for at the end; memory and time are those that a reader may take of a small file.
limits="-rss_limit_mb=2048 -malloc_limit_mb=2048 -timeout=10"
export OMP_NUM_THREADS=1
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/$here/leaks.txt:print_suppressions=0

[ $# -ge 1 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 2; }
seconds=$1
shift
targets=${*:-$all}

cmake --preset fuzz >/dev/null
# shellcheck disable=SC2086
ninja -C $build $(printf 'fuzz_%s ' $targets)

failed=""
for target in $targets; do
    mkdir -p $build/corpus/"$target" $build/found/"$target"
    if [ "$seconds" = --merge ]; then
        mkdir -p $build/merged/"$target"
        $build/tests/fuzz/fuzz_"$target" -merge=1 $limits $build/merged/"$target" $here/corpus/"$target" $build/corpus/"$target"
        continue
    fi
    dictionary=""
    [ ! -f $here/"$target".dict ] || dictionary=-dict=$here/$target.dict
    known=$here/regressions/$target
    [ -d "$known" ] || known=""
    # shellcheck disable=SC2086
    $build/tests/fuzz/fuzz_"$target" $limits $dictionary -max_total_time="$seconds" -max_len=65536 -print_final_stats=1 \
        -artifact_prefix=$build/found/"$target"/ $build/corpus/"$target" $here/corpus/"$target" $known >$build/"$target".log 2>&1 ||
        failed="$failed $target"
    tail -n 12 $build/"$target".log | sed "s/^/$target: /"
done
[ -z "$failed" ] || { echo "findings in:$failed (build/fuzz/*.log)"; exit 1; }
