#!/bin/sh
# Runs every command of README.md and of the pages of docs, except docs/research and docs/design, that stands in a block
# marked ```sh, in a scratch folder that has sample_dems/, with the tool on the PATH. A block marked ```output holds the output of the block before;
# empty lines do not count. Blocks marked ```sh mesh are run where dem2buildings_mesh is built, those
# marked ```sh page where pages are (D2B_BUILD_PAGE).
#   run_commands.sh <source folder> <folder of the tool> <scratch folder> <build folder>
# The library to build programs with is installed in <scratch folder>/installed.
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
mesh=$(command -v dem2buildings_mesh || true)
pages=$(grep -x D2B_BUILD_PAGE:BOOL=ON "$4/CMakeCache.txt" || true)
count=0
compared=0
for page in "$source_folder"/README.md "$source_folder"/docs/*.md "$source_folder"/docs/tasks/*.md \
        "$source_folder"/docs/reference/*.md "$source_folder"/docs/developers/*.md; do
    awk -v mesh="$mesh" -v pages="$pages" '/^```sh$/ || (mesh && /^```sh mesh$/) || (pages && /^```sh page$/) {
             kind = "C"; print "B"; next}
         /^```sh (mesh|page)$/ {without = 1}
         /^```output$/ {if (without) {without = 0; next} kind = "O"; next}
         /^```$/ {if (kind == "O") print "E"; kind = ""} kind {print kind $0}' "$page" > "$scratch/lines.txt"
    while IFS= read -r line; do
        text=${line#?}
        case $line in
            B) : > "$scratch/printed.txt"; : > "$scratch/expected.txt"; continue ;;
            O*) echo "$text" >> "$scratch/expected.txt"; continue ;;
            E)
                if ! diff -B "$scratch/expected.txt" "$scratch/printed.txt"; then
                    echo "$(basename "$page"): the page shows (<) another output than the commands print (>)"
                    exit 1
                fi
                compared=$((compared + 1))
                continue ;;
            C) continue ;;
        esac
        echo "$(basename "$page"): $text"
        if ! (cd "$scratch" && sh -eu -c "$text") > "$scratch/out.txt" 2> "$scratch/err.txt" < /dev/null; then
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
        cat "$scratch/out.txt" >> "$scratch/printed.txt"
        count=$((count + 1))
    done < "$scratch/lines.txt"
done
echo "$count commands of the documentation ran, $compared outputs are as shown"
[ "$count" -ge 60 ]
[ "$compared" -ge 5 ]
