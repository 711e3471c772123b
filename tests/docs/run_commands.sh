#!/bin/sh
# Runs every command of README.md, docs/*.md and docs/tasks/*.md that stands in a block marked ```sh, in a scratch folder where
# sample_dems/ lies beside and the tool is on the PATH.
#   run_commands.sh <source folder> <folder of the tool> <scratch folder> <build folder>
# What programs are built with is installed in <scratch folder>/installed.
set -eu
source_folder=$1
PATH=$2:$PATH
scratch=$3
export PATH

rm -rf "$scratch"
mkdir -p "$scratch"
ln -s "$source_folder/sample_dems" "$scratch/sample_dems"
mkdir "$scratch/docs"
ln -s "$source_folder/docs/examples" "$scratch/docs/examples"
cmake --install "$4" --prefix "$scratch/installed" > "$scratch/install.txt"
count=0
for page in "$source_folder"/README.md "$source_folder"/docs/*.md "$source_folder"/docs/tasks/*.md; do
    awk '/^```sh$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$page" > "$scratch/commands.txt"
    while IFS= read -r command; do
        [ -n "$command" ] || continue
        echo "$(basename "$page"): $command"
        if ! (cd "$scratch" && sh -eu -c "$command") > "$scratch/out.txt" 2> "$scratch/err.txt" < /dev/null; then
            echo "failed:"
            cat "$scratch/out.txt" "$scratch/err.txt"
            exit 1
        fi
        # A documented command runs without a complaint.
        if [ -s "$scratch/err.txt" ]; then
            echo "complained:"
            cat "$scratch/err.txt"
            exit 1
        fi
        count=$((count + 1))
    done < "$scratch/commands.txt"
done
echo "$count commands of the documentation ran"
[ "$count" -ge 60 ]
