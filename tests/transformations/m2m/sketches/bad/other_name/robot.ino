void setup() { pinMode(3, OUTPUT); }
void loop() {}
