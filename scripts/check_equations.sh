#!/bin/sh
# Fails if a comment cites an equation, as (eq. T6, T8) or (G5), that docs/theory.md does not have.
cd "$(dirname "$0")/.." || exit 1
status=0
for cited in $(sh scripts/list_sources.sh | xargs grep -ohE '(eq\. [CEFGHIJLMNOQRSTUX][0-9]+[^)]*|\([CEFGHIJLMNOQRSTUX][0-9]+a?)\)' |
    grep -oE '[CEFGHIJLMNOQRSTUX][0-9]+a?' | sort -u); do
    grep -qE "\($cited\)\$" docs/theory.md && continue
    echo "equation $cited is cited, but docs/theory.md has none of that number:"
    sh scripts/list_sources.sh | xargs grep -nE "[( ]$cited[,) ]"
    status=1
done
exit "$status"
