#!/bin/sh
# Fuzzes the deck reader (tests/fuzz_deck.c) from tests/corpus with clang's libFuzzer.
#
# usage: fuzz.sh [SECONDS]     default 60
# What it finds new stays in build/fuzz/corpus; an input that breaks the reader is named and kept in build/fuzz.
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-60}

sh scripts/setup.sh --ci
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz -- --quiet
mkdir -p build/fuzz/corpus build/fuzz/empty
# The keywords, so that the fuzzer needs not guess them.
sed -n 's/\\//g; s/^###* \(\*[A-Z_]*\).*/"\1"/p; s/^| \(\*[A-Z_]*\) |.*/"\1"/p' docs/keywords.md >build/fuzz/keywords.dict
# *INCLUDE finds what lies in the working directory: nothing
cd build/fuzz/empty
exec ../tests/fuzz_deck -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=20000 -verbosity=0 -print_final_stats=1 \
    -dict=../keywords.dict -artifact_prefix=../ ../corpus ../../../tests/corpus
