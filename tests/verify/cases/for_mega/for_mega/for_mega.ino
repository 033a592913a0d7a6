void setup() { Serial3.begin(9600); }

void loop() { digitalWrite(53, HIGH); }
