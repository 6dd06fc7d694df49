#!/bin/bash
# build_example.sh SOURCE BUILD FOLDER CXXFLAGS: installs the coupler from BUILD as somebody else would, and builds the
# example against it out of tree, in FOLDER.
source_dir=$1 build=$2 folder=$3 flags=$4
set -e
rm -rf "$folder"
mkdir -p "$folder"
cmake --install "$build" --component coupler --prefix "$folder/prefix" >"$folder/install.log"
# what the solvers share among themselves must not be needed, nor lie about
if grep -E "/(support|record)|yaml|hdf5" <(sed "s|$folder||" "$folder/install.log"); then
  echo "build_example: these do not belong to the coupler's installation"
  exit 1
fi
cmake -S "$source_dir/coupler_lib/examples" -B "$folder/example" -DCMAKE_PREFIX_PATH="$folder/prefix" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags -Wall -Wextra -Werror"
cmake --build "$folder/example"
lines=$(wc -l <"$source_dir/coupler_lib/examples/foreign_grid.cpp")
[ "$lines" -le 100 ] || { echo "build_example: an example of $lines lines is no invitation"; exit 1; }
