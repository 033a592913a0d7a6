// Reads a DHT22 by itself: 40 bits, a long high is a one.
byte data[5];

void setup() {
  Serial.begin(115200);
}

void loop() {
  digitalWrite(2, LOW);
  pinMode(2, OUTPUT);
  delay(2);
  pinMode(2, INPUT_PULLUP);
  noInterrupts();
  pulseIn(2, HIGH, 1000);  // the high of the answer
  for (byte i = 0; i < 40; i++) {
    unsigned long width = pulseIn(2, HIGH, 1000);
    data[i / 8] = data[i / 8] << 1 | (width > 45);
  }
  interrupts();
  for (byte i = 0; i < 5; i++) {
    Serial.print(data[i]);
    Serial.print(i < 4 ? ' ' : '\n');
  }
  delay(100);
}
