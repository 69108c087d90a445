#!/bin/bash -eu
# Builds every fuzzer for ClusterFuzzLite and for OSS-Fuzz: $SRC/adsdv is this repository, and what is to run goes to $OUT,
# each fuzzer with its options, its dictionary, and the inputs that it starts from.

cd "$SRC/adsdv"
cargo fuzz build -O --debug-assertions

bin=fuzz/target/$(rustc -vV | sed -n 's/^host: //p')/release
for target in $(cargo fuzz list); do
  cp "$bin/$target" "$OUT/"
  cp fuzz/libfuzzer.options "$OUT/$target.options"
  inputs=()
  for folder in corpus regressions; do
    [ ! -d "fuzz/$folder/$target" ] || inputs+=("fuzz/$folder/$target")
  done
  rm -f "$OUT/${target}_seed_corpus.zip"
  [ ${#inputs[@]} -eq 0 ] || zip -q -r "$OUT/${target}_seed_corpus.zip" "${inputs[@]}"
  [ ! -f "fuzz/dictionaries/$target.dict" ] || cp "fuzz/dictionaries/$target.dict" "$OUT/"
done
