#define OUTS(X) X(2) X(3) X(9)
#define MODE(n) pinMode(n, OUTPUT);
void setup() { OUTS(MODE) pinMode(4, OUTPUT); }
void loop() { digitalWrite(9, HIGH); }
