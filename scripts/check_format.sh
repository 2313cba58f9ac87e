#!/bin/sh
# Fails if clang-format would change a C file. `clang-format -i FILE` mends it.
cd "$(dirname "$0")/.." || exit 1
sh scripts/list_sources.sh | xargs clang-format --dry-run --Werror
