// Constants that no float equals are doubles where a double has 64 bits.
#define STEP 0.1
#define HALF 0.5
float level = 0.1;
double other = 0.3;
struct { float gain; } set = {0.2};
float of(float x) { return x * 2; }
void setup() { Serial.begin(9600); while (!Serial && millis() < 3000) {} }
void loop() {
  if (level == (float)0.1) Serial.println("a");
  if (level == (float)STEP) Serial.println("b");
  if (level != HALF) Serial.println("c");
  if ((float)-0.7 != set.gain) Serial.println("d");
  if (other == 0.3) Serial.println("e");
  if (level == 0.1f) Serial.println("f");
  if (of(level) == (float)0.2) Serial.println("g");
  if (level > 0.1) Serial.println("h");
  level += 0.1;
}
