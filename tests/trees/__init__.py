"""Plans made of tasks, by chance: written, run, and looked at when they have ended."""
