// Asks on one line that a pull-up holds high, and prints the answers.
const unsigned int bitTime = 104;  // us: 9600 baud

void put(byte value) {
  noInterrupts();
  for (unsigned int bits = value << 1 | 0x200, left = 10; left; left--, bits >>= 1) {
    if (bits & 1) pinMode(8, INPUT_PULLUP);
    else {
      digitalWrite(8, LOW);
      pinMode(8, OUTPUT);
    }
    delayMicroseconds(bitTime - 9);
  }
  interrupts();
}

int take() {
  for (unsigned long begun = millis(); digitalRead(8);)
    if (millis() - begun > 20) return -1;
  delayMicroseconds(bitTime / 2);
  byte value = 0;
  for (byte bit = 0; bit < 8; bit++) {
    delayMicroseconds(bitTime - 5);
    value = value >> 1 | digitalRead(8) << 7;
  }
  delayMicroseconds(bitTime);
  return value;
}

void ask(const char *text) {
  for (; *text; text++) put(*text);
  put('\r');
  int value = take();
  if (value < 0) Serial.print('?');
  for (; value >= 0 && value != '\r'; value = take()) Serial.print((char)value);
  Serial.println();
}

void setup() {
  Serial.begin(115200);
  pinMode(8, INPUT_PULLUP);
  ask("dist");
  ask("dist");
  ask("dist");
  ask("what");
}

void loop() {}
