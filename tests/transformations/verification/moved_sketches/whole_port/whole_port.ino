// Six lamps at one port run from side to side.
const byte steps[] = {0x04, 0x0C, 0x18, 0x30, 0x60, 0xC0};

void setup() {
  DDRD = 0xFC;
  PORTD = 0;
}

void loop() {
  for (byte i = 0; i < sizeof(steps); i++) {
    PORTD = steps[i];
    delay(15);
  }
}
