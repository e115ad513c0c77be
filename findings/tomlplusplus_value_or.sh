#!/usr/bin/env bash
# toml++: table["time"].value_or(1) gives 1 where the file says time = 0.5. The type of the number in the program decides what
# is read: 1 asks for an integer, which 0.5 is not, and the default stands for what cannot be read as well as for what is not
# there. So it is with a number in quotation marks. value_or(1.0) gives 0.5, and reads time = 2 as well; true reads as the
# integer 1, but not as a double.
# A guess would be that the default is for what is missing, and that a wrong type is an error, or converted as in C++, to 0.
# Seen with toml++ 3.3.0 (Debian 12).
# Output seen: 0.5 by 1: 1; 0.5 by 1.0: 0.5; 2 by 1.0: 2; "0.5" by 1.0: 1; true by 7: 1; true by 7.0: 7; missing by 1: 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" libtomlplusplus-dev=3.3.0+ds-1 g++=4:12.2.0-3
cat >"$scratch/12/root/read.cpp" <<'END'
#include <iostream>
#include <toml++/toml.h>

int main() {
  const toml::table table = toml::parse("half = 0.5\ntwo = 2\ntext = '0.5'\nyes = true");
  std::cout << "0.5 by 1: " << table["half"].value_or(1) << '\n'
            << "0.5 by 1.0: " << table["half"].value_or(1.0) << '\n'
            << "2 by 1.0: " << table["two"].value_or(1.0) << '\n'
            << "'0.5' by 1.0: " << table["text"].value_or(1.0) << '\n'
            << "true by 7: " << table["yes"].value_or(7) << '\n'
            << "true by 7.0: " << table["yes"].value_or(7.0) << '\n'
            << "missing by 1: " << table["missing"].value_or(1) << '\n';
}
END
within "$scratch/12" sh -c 'cd /root && g++ -std=c++17 -o read read.cpp && ./read' >"$scratch/said" 2>"$scratch/log" ||
  fail "ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "what is read"
0.5 by 1: 1
0.5 by 1.0: 0.5
2 by 1.0: 2
'0.5' by 1.0: 1
true by 7: 1
true by 7.0: 7
missing by 1: 1
END
