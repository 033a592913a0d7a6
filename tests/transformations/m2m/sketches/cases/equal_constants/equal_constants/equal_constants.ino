// Constants that no float equals are doubles where a double has 64 bits.
#define STEP 0.1
#define HALF 0.5
float level = 0.1;
double other = 0.3;
struct { float gain; } set = {0.2};
float of(float x) { return x * 2; }
void setup() { Serial.begin(9600); }
void loop() {
  if (level == 0.1) Serial.println("a");
  if (level == STEP) Serial.println("b");
  if (level != HALF) Serial.println("c");
  if (-0.7 != set.gain) Serial.println("d");
  if (other == 0.3) Serial.println("e");
  if (level == 0.1f) Serial.println("f");
  if (of(level) == 0.2) Serial.println("g");
  if (level > 0.1) Serial.println("h");
  level += 0.1;
}
