#!/bin/sh
# Prints the project's C files, one per line, headers too.
cd "$(dirname "$0")/.." || exit 1
ls solver/*.[ch] elements/*.[ch] contact/*.[ch] airbag/*.[ch] fold/*.[ch] io/*.[ch] tests/*.[ch] benchmarks/*.[ch] examples/*.[ch] \
    2>/dev/null
exit 0
