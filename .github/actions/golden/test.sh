#!/usr/bin/env bash
# Runs pytest with a report of golden pictures; the outputs say how it went, a later step fails.
#
# In:  GOLDEN_ARGUMENTS, GOLDEN_FOLDER, GOLDEN_PYTHON, and what GitHub sets: GITHUB_ACTION_PATH,
#      GITHUB_OUTPUT, GITHUB_STEP_SUMMARY. Out: the report, results as JSON, XML of JUnit; `status` and
#      `changed`; a table in the summary.
set -uo pipefail
export CI=${CI:-true}  # under which golden pictures are never written
folder=${GOLDEN_FOLDER:-golden-report} python=${GOLDEN_PYTHON:-python}

# Words as a shell reads them, quotes too, but neither variables nor commands in them: they come back
# with every sign quoted that a shell has a meaning for.
words=$("$python" -c 'import shlex, sys; print(shlex.join(shlex.split(sys.argv[1])), end="")' "${GOLDEN_ARGUMENTS:-}") ||
    { echo "golden: cannot read the arguments: $GOLDEN_ARGUMENTS" >&2; exit 2; }
eval "arguments=($words)"

mkdir -p "$folder" || exit 1
# Of an earlier step: pytest may end before it writes any.
rm -f "$folder/report.html" "$folder/golden.json" "$folder/junit.xml"
"$python" -m pytest --golden-report="$folder/report.html" --golden-json="$folder/golden.json" \
    --junitxml="$folder/junit.xml" ${arguments[@]+"${arguments[@]}"}
status=$?

changed=0
if [ -f "$folder/golden.json" ]; then
    changed=$("$python" "$GITHUB_ACTION_PATH/summary.py" "$folder/golden.json" "$GITHUB_STEP_SUMMARY") || changed=0
fi
printf 'status=%s\nchanged=%s\n' "$status" "$changed" >>"$GITHUB_OUTPUT"
