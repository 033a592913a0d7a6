byte a[30000], b[30000], c[30000];

void setup() {
  for (unsigned int i = 0; i < sizeof a; i++) a[i] = b[i] = c[i] = digitalRead(i % 14);
}

void loop() {
  const unsigned int i = millis() % sizeof a;
  digitalWrite((a[i] + b[i] + c[i]) % 14, HIGH);
}
