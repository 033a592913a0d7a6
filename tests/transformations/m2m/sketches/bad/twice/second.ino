void beep() { tone(9, 880); }
