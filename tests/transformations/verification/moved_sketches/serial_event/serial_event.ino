// Text comes by the function that runs between two loops.
String line = "";
void setup() { Serial.begin(9600); }
void loop() { delay(10); }
void serialEvent() {
  while (Serial.available()) {
    char c = (char)Serial.read();
    if (c == '\n') { Serial.println("got " + line); line = ""; }
    else line += c;
  }
}
