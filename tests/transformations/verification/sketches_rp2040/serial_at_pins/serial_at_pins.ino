// What comes on the first serial line goes out on the second, as a capital.
void setup() {
  Serial1.begin(9600);
  Serial2.begin(19200);
}

void loop() {
  if (Serial1.available()) Serial2.write(Serial1.read() - 32);
}
