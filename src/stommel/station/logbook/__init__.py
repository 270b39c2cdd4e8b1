"""The log book: notes of people, and beside them what people did, alarms, and what the vehicle said."""
