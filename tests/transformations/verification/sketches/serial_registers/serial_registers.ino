// Reads a register, two in a row, and one that it wrote before.
byte put(byte value) {
  byte answer = 0;
  for (byte bit = 0; bit < 8; bit++) {
    answer = answer << 1 | digitalRead(8);
    digitalWrite(7, value >> (7 - bit) & 1);
    digitalWrite(6, HIGH);
    digitalWrite(6, LOW);
  }
  return answer;
}

void setup() {
  Serial.begin(115200);
  for (byte pin = 5; pin < 8; pin++) pinMode(pin, OUTPUT);
  digitalWrite(5, HIGH);
  digitalWrite(5, LOW);
  put(0x80 | 2);
  Serial.println(put(0));
  digitalWrite(5, HIGH);
  digitalWrite(5, LOW);
  put(0xC0 | 2);
  Serial.println(put(0));
  Serial.println(put(0));
  digitalWrite(5, HIGH);
  digitalWrite(5, LOW);
  put(9);
  put(77);
  digitalWrite(5, HIGH);
  digitalWrite(5, LOW);
  put(0x80 | 9);
  Serial.println(put(0));
  digitalWrite(5, HIGH);
}

void loop() {}
