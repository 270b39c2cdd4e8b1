"""The log book: notes of people, and beside them commands, missions, alarms, and what the vehicle said."""
