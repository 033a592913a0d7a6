void tick(void) { pause(DELAY); }
