void setup() {
  Serial.begin(9600);
  while (!Serial && millis() < 3000);
  Serial.println("ready");
}
void loop() {}
