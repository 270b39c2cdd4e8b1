"""The log book: notes of people, and beside them commands, missions and alarms."""
