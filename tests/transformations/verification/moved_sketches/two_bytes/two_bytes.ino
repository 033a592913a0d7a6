// A temperature out of two bytes; below zero a heater goes on.
byte raw[2] = {0xFB, 0x2E};

int temperature() {
  int t = (raw[0] << 8) | raw[1];
  return t;
}

void setup() {
  Serial.begin(9600);
  pinMode(5, OUTPUT);
}

void loop() {
  int t = temperature();
  Serial.println(t);
  digitalWrite(5, t < 0 ? HIGH : LOW);
  raw[0] = raw[0] ? 0 : 0xFB;
  delay(80);
}
