void setup() {
  auto out = [](int p) { pinMode(p, OUTPUT); };
  out(7);
  out(9);
}

void loop() {
  auto lit = [](byte p = 12) { digitalWrite(p, HIGH); };
  lit();
  lit(8);
}
