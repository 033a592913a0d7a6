// Prints at once, and again when a PC has opened the console.
void setup() {
  Serial.println("lost");
  while (!Serial) {}
  Serial.println("heard");
}

void loop() {}
