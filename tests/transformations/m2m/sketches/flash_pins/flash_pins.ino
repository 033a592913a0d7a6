const byte tab[] PROGMEM = {2, 4};
void setup() { for (byte i = 0; i < 2; i++) pinMode(pgm_read_byte(&tab[i]), OUTPUT); }
void loop() { digitalWrite(pgm_read_byte(&tab[0]), HIGH); delay(100); digitalWrite(pgm_read_byte(&tab[0]), LOW); delay(100); }
