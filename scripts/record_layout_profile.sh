#!/bin/bash
# Records which machine code of the code generator runs, for cmake/arrange_code.cmake (decision 139). To be done again when LLVM's version
# changes, or when `./dev bench compile` shows that building became slower. Needs a release build, 8 GB of memory and a minute and a half.
set -euo pipefail

root=$(cd "$(dirname "$0")/.." && pwd)
bolt=/usr/lib/llvm-19/bin
linked=$root/build/codegen/layout_profile.fdata.linked.so
archive=$root/codegen/plugin/layout_profile.tar.xz
fewest=100 # branches of 10,000 lines: those taken less often make half of the file and change nothing

[ -f "$linked" ] || {
    echo "record_layout_profile.sh: $linked is missing: run ./dev build with llvm-bolt (package bolt-19) first" >&2
    exit 1
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/lib" "$work/raw"
cp "$root/build/rapidc" "$work/"
ln -s "$root"/build/lib/*.a "$work/lib/"
"$bolt/llvm-bolt" "$linked" -instrument -o "$work/lib/rapidc_codegen.so" \
    --instrumentation-file="$work/raw/profile" --instrumentation-file-append-pid >"$work/log" 2>&1 || {
    tail "$work/log" >&2
    exit 1
}
export RAPIDC_CACHE=$work/cache
PYTHONPATH=$root/tests/bench python3 -c '
import sys, compile_bench, generate_project
generate_project.generate(sys.argv[1], 10_000, "mixed")
compile_bench.write_main(sys.argv[1] + "/rapid")
' "$work/project"
"$work/rapidc" build "$work/project/rapid" -o "$work/program"
awk -v fewest=$fewest '$NF >= fewest' "$work"/raw/* >"$work/layout_profile.fdata"
tar -C "$work" --owner=0 --group=0 -c layout_profile.fdata | xz -9e >"$archive"
ls -l "$archive"
