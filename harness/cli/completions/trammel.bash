# Completion for bash: commands, their options, cases of the catalogue, and files.
_trammel() {
  local word=${COMP_WORDS[COMP_CWORD]} words
  if [ "$COMP_CWORD" -eq 1 ] || [ "${COMP_WORDS[COMP_CWORD - 1]}" = help ]; then
    words=$(trammel --help 2>/dev/null | awk '/^Subcommands:/ { on = 1; next } /^$/ { on = 0 } on { print $1 }')
  elif [[ $word == -* ]]; then
    words=$(trammel "${COMP_WORDS[1]}" --help 2>/dev/null | grep -oE -e '^ +(-[A-Za-z], *)?--[a-z-]+' | grep -oE -e '--[a-z-]+')
  elif [ "$word" != : ] && [ "${COMP_WORDS[COMP_CWORD - 1]}" != : ]; then # not a variant
    words=$(trammel list 2>/dev/null | awk 'NR > 1 && NF > 3 { print $1 }')
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  [ "$COMP_CWORD" -eq 1 ] || mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
}
complete -o filenames -F _trammel trammel
