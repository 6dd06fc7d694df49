#!/bin/bash
# build_and_run.sh SOURCE BUILD SECONDS REGEX CXXFLAGS COMMAND...: installs the coupler from BUILD as somebody else
# would, builds the example against it out of tree, and runs COMMAND in which @example@ stands for it.
source_dir=$1 build=$2 seconds=$3 pattern=$4 flags=$5
shift 5
set -e
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --component coupler --prefix "$work/prefix" >"$work/install.log"
# what the solvers share among themselves must not be needed, nor lie about
if grep -E "support|record|yaml|hdf5" "$work/install.log"; then
  echo "build_and_run: these do not belong to the coupler's installation"
  exit 1
fi
cmake -S "$source_dir/coupler_lib/examples" -B "$work/example" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_FLAGS="$flags -Wall -Wextra -Werror" >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/example"
[ "$(wc -l <"$source_dir/coupler_lib/examples/foreign_grid.cpp")" -le 100 ]
"$source_dir/tests/support/mpi_test" "$seconds" passes "$pattern" "${@//@example@/$work/example/foreign_grid}"
