"""The soak: millions of steps of tasks of all kinds in one interpreter, whose memory must not grow."""
