void setup() {
  Serial.begin(9600);
  while (!Serial) { delay(10); }
  Serial.println("ready");
}
void loop() {}
