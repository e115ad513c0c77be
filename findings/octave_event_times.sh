#!/usr/bin/env bash
# Which events ode45 and ode15s of Octave find, and where, depends on the times at which the solution is asked for. They look at
# the sign of the event function at those times alone and draw a straight line between them, though the steps of the method
# lie closer. A small RelTol does not help. Of three crossings between output times one is left, at a time when nothing crosses,
# and the state given with an event, from which the next phase is to start, lies on the same line: so a valve opens at a wrong
# time with a wrong flow. With a time span of two numbers the lines join the steps, and a small RelTol makes them short.
# A guess would be as MATLAB's functions of the same names: zeros are looked for within the steps, whatever the output times.
# Seen with Octave 7.3.0 (Debian 12): y'' = -y from y = 1 to time 10, RelTol 1e-6. y is zero at 1.5708, 4.7124 and 7.8540, with
# the slope -1 or 1; at 6.28 it is 1.
# Output seen, of both functions: in their own steps 1.57, 4.71, 7.85, slopes 0.99 to 1; at 0, 5, 10 a single one at 6.26, slope
# 0.85; at 0, 1, ..., 10 1.56, 4.70, 7.84, slopes 0.88 to 0.94.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" octave=7.3.0-2
cat >"$scratch/12/root/events.m" <<'END'
1;
function [value, stop, direction] = crossing (t, y)
  value = y(1);
  stop = 0;
  direction = 0;
end

options = odeset ("RelTol", 1e-6, "AbsTol", 1e-6, "Events", @crossing);
for solver = {@ode45, @ode15s}
  for times = {[0 10], [0 5 10], 0:10}
    [t, y, at, states] = solver{1} (@(t, y) [y(2); -y(1)], times{1}, [1; 0], options);
    printf ("%s, %d times: zeros%s; slopes%s\n", func2str (solver{1}), numel (times{1}), sprintf (" %.2f", at),
            sprintf (" %.2f", states(:, 2)));
  end
end
END
within "$scratch/12" octave-cli --quiet --no-init-file --no-history /root/events.m >"$scratch/said" 2>"$scratch/log" ||
  fail "octave ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the events"
ode45, 2 times: zeros 1.57 4.71 7.85; slopes -0.99 0.99 -1.00
ode45, 3 times: zeros 6.26; slopes 0.85
ode45, 11 times: zeros 1.56 4.70 7.84; slopes -0.88 0.90 -0.94
ode15s, 2 times: zeros 1.57 4.71 7.85; slopes -1.00 1.00 -1.00
ode15s, 3 times: zeros 6.26; slopes 0.85
ode15s, 11 times: zeros 1.56 4.70 7.84; slopes -0.88 0.90 -0.94
END
