const byte rows[] = {1, 2, 4};

void setup() {
  pinMode(4, OUTPUT), pinMode(5, OUTPUT), pinMode(6, OUTPUT), pinMode(7, OUTPUT);
  digitalWrite(4, LOW), digitalWrite(5, HIGH), digitalWrite(6, LOW), digitalWrite(7, HIGH);
}

void loop() {
  for (byte row = 0; row < 3; row++) digitalWrite(4, (rows[row] << 4) >> 4 & 1), digitalWrite(5, (rows[row] << 4) >> 5 & 1), digitalWrite(6, (rows[row] << 4) >> 6 & 1), digitalWrite(7, (rows[row] << 4) >> 7 & 1);
}
