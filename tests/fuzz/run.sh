#!/bin/sh
# Fuzzes every target, or those that are named, for so many seconds each, one after the other.
# Needs a nightly toolchain and `cargo install cargo-fuzz`.
#   sh tests/fuzz/run.sh 600
#   sh tests/fuzz/run.sh 3600 geotiff npy
# Seeds are written by the same code that the tests use. What fails is left in artifacts/TARGET/;
# `cargo +nightly fuzz run TARGET artifacts/TARGET/FILE` shows it again.
set -eu
cd "$(dirname "$0")"
seconds=${1:?seconds for each target}
shift
[ $# -gt 0 ] || set -- $(cargo +nightly fuzz list)

cargo run --quiet --example seeds
cargo +nightly fuzz build
# A small file that asks for much memory, an input that takes seconds and a panic are all faults.
for target in "$@"; do
    RAYON_NUM_THREADS=1 cargo +nightly fuzz run "$target" -- \
        -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=512 \
        -max_len=4096 -dict="words/$target.dict" -print_final_stats=1
done
