// Reads a Sony remote control: 12 bits, the lowest first.
void setup() {
  Serial.begin(115200);
}

void loop() {
  if (pulseIn(10, LOW, 100000) < 2000) return;
  unsigned int code = 0;
  for (byte bit = 0; bit < 12; bit++)
    if (pulseIn(10, LOW, 5000) > 900) code |= 1 << bit;
  Serial.print(code & 0x7F);
  Serial.print('/');
  Serial.println(code >> 7);
}
