struct Wheel { int16_t ticks; int rpm; };
class Sum {
 public:
  int16_t total = 0;
  void add(int x) { total += x * 700; }
};
Wheel left;
Sum sum;
int16_t position, limit;
int16_t ring[4];
int16_t level;
int16_t *shown = &level;
void move(int16_t *place) { *place += 1000; }
void fill(int16_t values[], int count) {
  for (int i = 0; i < count; i++) values[i] += 500;
}
void raise(int16_t &value) { value += 500; }
void setup() {}
void loop() {
  left.ticks += 500;
  left.rpm = 7;
  sum.add(30);
  move(&position);
  fill(ring, 4);
  raise(level);
  tone(8, (uint16_t)(left.ticks + sum.total + position + limit + ring[1] + *shown));
}
