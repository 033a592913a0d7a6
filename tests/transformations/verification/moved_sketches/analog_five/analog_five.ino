// A sensor at A5 dims a lamp with map().
void setup() {
  pinMode(3, OUTPUT);
}

void loop() {
  int v = analogRead(A5);
  digitalWrite(3, map(v, 0, 1023, 0, 100) > 40);
  delay(10);
}
