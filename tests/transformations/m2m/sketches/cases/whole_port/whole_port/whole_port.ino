const byte rows[] = {1, 2, 4};

void setup() {
  DDRD = 0xF0;
  PORTD = B10100000;
}

void loop() {
  for (byte row = 0; row < 3; row++) PORTD = rows[row] << 4;
}
