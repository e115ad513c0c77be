"""What reports of several kinds show of a run: energies, phases, wave speeds, the deformed tube."""
