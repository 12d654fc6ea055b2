# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Completion of gloam's commands, options, scenes, knobs and their values in bash. It asks the program itself.

_gloam_options() { "$1" "$2" --help 2>/dev/null | grep -oE '^  (-h,)?--[a-z-]+' | sed 's/^ *\(-h,\)\?//'; }

# The knobs as KNOB=, or the values of one as KNOB=VALUE.
_gloam_knobs() {
  "$1" knobs 2>/dev/null | awk -v word="$2" '
    match($0, /^ *[a-z_]+\.[a-z_]+=/) {
      knob = $1; sub(/=.*/, "", knob)
      if (index(word, knob "=") != 1) { print knob "="; next }
      if (match($0, /\(.*\)/)) {
        n = split(substr($0, RSTART + 1, RLENGTH - 2), values, / \| /)
        for (i = 1; i <= n; ++i) if (values[i] !~ / /) print knob "=" values[i]
      }
    }'
}

_gloam() {
  local program=$1 word line=${COMP_LINE:0:COMP_POINT} command="" previous="" words i
  # `=` separates words in COMP_WORDS, so the line is split at spaces here.
  read -ra words <<<"$line"
  [[ $line == *" " ]] && words+=("")
  word=${words[-1]}
  [ ${#words[@]} -gt 1 ] && previous=${words[-2]}
  for ((i = 1; i < ${#words[@]} - 1; ++i)); do
    [[ ${words[i]} == -* ]] || { command=${words[i]} && break; }
  done
  local replies=""
  if [ -z "$command" ]; then
    replies="$("$program" --help 2>/dev/null | awk '/^Subcommands:/ {on = 1; next} on && /^  [a-z]/ {print $1}') --help --version"
  elif [ "$previous" = --set ] || [ "$previous" = --knobs ]; then
    replies=$(_gloam_knobs "$program" "$word")
    [[ $replies == *= ]] && compopt -o nospace 2>/dev/null
  elif [ "$previous" = --device ]; then
    replies="auto cpu gpu"
  elif [[ $word == -* ]]; then
    replies=$(_gloam_options "$program" "$command")
  elif [[ $word == b* ]]; then
    replies=$("$program" scenes 2>/dev/null | awk '{print $1}')
  fi
  # readline replaces what follows the last `=` or `:` of the word.
  local head=${word%"${word##*[=:]}"}
  COMPREPLY=()
  while IFS= read -r reply; do
    [ -z "$reply" ] || COMPREPLY+=("${reply#"$head"}")
  done < <(compgen -W "$replies" -- "$word")
  [ ${#COMPREPLY[@]} -gt 0 ] || compopt -o default 2>/dev/null
}
complete -F _gloam gloam
