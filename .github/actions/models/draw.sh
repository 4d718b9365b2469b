#!/usr/bin/env bash
# Draws the models that differ from a commit, and says in outputs and summary which they are.
#
# In:  MODELS_BASE, MODELS_PATTERNS, MODELS_SIZE, MODELS_FOLDER, MODELS_PYTHON, and what GitHub sets:
#      GITHUB_ACTION_PATH, GITHUB_OUTPUT, GITHUB_STEP_SUMMARY. Out: the folder; `changed` and `broken`;
#      a table in the summary.
set -euo pipefail
base=${MODELS_BASE:-} python=${MODELS_PYTHON:-python}
[[ $base =~ ^[0-9a-f]{7,64}$ && ! $base =~ ^0+$ ]] || { echo "models: no commit to compare with: '$base'" >&2; exit 2; }

# A checkout holds one commit, unless it was asked for more.
git cat-file -e "$base^{commit}" 2>/dev/null || git fetch --quiet --no-tags --depth=1 origin "$base"
before=$(mktemp -d)
trap 'git worktree remove --force "$before/tree" 2>/dev/null; rm -rf "$before"' EXIT
git worktree add --quiet --detach "$before/tree" "$base"

mapfile -t patterns < <(printf '%s' "${MODELS_PATTERNS:-}" | sed '/^[[:space:]]*$/d')
"$python" "$GITHUB_ACTION_PATH/models.py" --before "$before/tree" --base "$base" --size "${MODELS_SIZE:-480x360}" \
    --folder "${MODELS_FOLDER:-model-diff}" --summary "$GITHUB_STEP_SUMMARY" -- ${patterns[@]+"${patterns[@]}"} >>"$GITHUB_OUTPUT"
