void setup() {
  Serial.begin(9600);
  while (!Serial && millis() < 3000) { delay(10); }
  Serial.println("ready");
}
void loop() {}
