#!/usr/bin/env bash
# ode23s of Octave, a method for stiff equations, takes as many steps as an explicit one where its Jacobian is a sparse matrix.
# The same numbers as a full matrix give few steps. In the sparse branch the second stage is multiplied by a factor of the
# decomposition where it should be permuted; the error control notices, and keeps the steps small, so results are right and
# nothing is said. What was to save time takes thirty times the steps with 40 unknowns, and more on a finer mesh.
# A guess would be the same steps, each of them cheaper.
# Seen with Octave 7.3.0 (Debian 12): diffusion on n points of a line up to time 0.3, default tolerances.
# Output seen, steps with a full Jacobian, with a sparse one, and of ode45: n = 10: 16, 61, 34; n = 20: 16, 160, 138; n = 40:
# 16, 548, 547; errors below 0.001.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" octave=7.3.0-2
cat >"$scratch/12/root/stiff.m" <<'END'
for n = [10 20 40]
  A = (n + 1)^2 * spdiags (ones (n, 1) .* [1 -2 1], -1:1, n, n);
  start = sin (pi * (1:n)' / (n + 1));
  exact = start * exp (-4 * (n + 1)^2 * sin (pi / 2 / (n + 1))^2 * 0.3);
  slope = @(t, y) A * y;
  [t, full_y] = ode23s (slope, [0 0.3], start, odeset ("Jacobian", full (A)));
  [s, sparse_y] = ode23s (slope, [0 0.3], start, odeset ("Jacobian", A));
  [r, other_y] = ode45 (slope, [0 0.3], start);
  wrong = max (abs ([full_y(end, :)', sparse_y(end, :)', other_y(end, :)'] - exact)(:)) > 0.001;
  printf ("n = %d: steps full %d, sparse %d, ode45 %d%s\n", n, numel (t) - 1, numel (s) - 1, numel (r) - 1,
          {"", ", wrong"}{1 + wrong});
end
END
within "$scratch/12" octave-cli --quiet --no-init-file --no-history /root/stiff.m >"$scratch/said" 2>"$scratch/log" ||
  fail "octave ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the steps"
n = 10: steps full 16, sparse 61, ode45 34
n = 20: steps full 16, sparse 160, ode45 138
n = 40: steps full 16, sparse 548, ode45 547
END
