typedef int Angle;
int height;
Angle turned;
char side = -1;
template <typename T> T twice(T value) { return value * 2; }
template <typename T> T same(T value) { return value; }
template <class T, int N> class Sums { T all[N]; public: void add(T value) { all[0] += value; } };
Sums<int, 4> sums;
void flip(char *way) { *way ^= 2; }
void setup() { Serial.begin(9600); while (!Serial && millis() < 3000) {} }
void loop() {
  char text[] = "12";
  sscanf(text, "%d", &height);
  height += 500;
  turned += 90;
  Serial.println(twice(30000) + twice<long>(5) + same(7));
  flip(&side);
  if (side < 0) tone(8, (uint16_t)(height + turned));
}
