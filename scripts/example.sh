#!/bin/sh
# Installs what is missing, builds billow and inflates the main example, a driver's airbag that starts flat. Ends with the
# files it wrote and the numbers to expect beside those obtained; fails if they differ.
set -eu
cd "$(dirname "$0")/.."
deck=build/driver-bag.k
results=build/driver-bag.results
picture=build/driver-bag.png

sh scripts/setup.sh
cmake --preset release
quiet=
[ -t 1 ] || quiet="-- --quiet"
cmake --build --preset release --target billow make_deck $quiet
build/release/make_deck driver-bag >"$deck"
build/release/billow run "$deck" -o "$results"
/usr/bin/python3 examples/render.py shape "$results" -o "$picture" --times 0 0.01 0.02 0.04 ||
    echo "example.sh: no picture: python3-numpy, python3-h5py and python3-matplotlib are needed for it" >&2

cat <<END

A driver's airbag has inflated from flat. What there is to see, below $(pwd):
  $picture                   the bag at 0, 10, 20 and 40 ms
  $results/results.vtkhdf    for ParaView 5.12 or later: open, Apply, play (older: results.xdmf)
  $results/abstat.csv        pressure, volume, temperature and flows over time
  $results/glstat.csv        energies over time
  $results/log.txt           what billow found in the deck $deck
Numbers to expect:
END
/usr/bin/python3 scripts/compare_results.py "$results" examples/driver-bag/expected.csv
