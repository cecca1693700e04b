# Completion for fish: commands, their options, cases of the catalogue, and files.
function __trammel_commands
    trammel --help 2>/dev/null | awk '/^Subcommands:/ { on = 1; next } /^$/ { on = 0 } on { print $1 }'
end
function __trammel_options
    set -l command (commandline -opc)[2]
    trammel $command --help 2>/dev/null | string match -rg '^ +(?:-[A-Za-z], *)?(--[a-z-]+)'
end
function __trammel_cases
    trammel list 2>/dev/null | awk 'NR > 1 && NF > 3 { print $1 }'
end
complete -c trammel -n 'test (count (commandline -opc)) -eq 1; or test (commandline -opc)[-1] = help' -f -a '(__trammel_commands)'
complete -c trammel -n 'test (count (commandline -opc)) -gt 1' -a '(__trammel_cases)'
complete -c trammel -n 'test (count (commandline -opc)) -gt 1; and string match -q -- "-*" (commandline -ct)' -f -a '(__trammel_options)'
