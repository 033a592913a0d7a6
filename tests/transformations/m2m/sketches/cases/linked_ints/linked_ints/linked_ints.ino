struct Wheel { int ticks; int rpm; };
class Sum {
 public:
  int total = 0;
  void add(int x) { total += x * 700; }
};
Wheel left;
Sum sum;
int position, limit;
int ring[4];
int level;
int *shown = &level;
void move(int *place) { *place += 1000; }
void fill(int values[], int count) {
  for (int i = 0; i < count; i++) values[i] += 500;
}
void raise(int &value) { value += 500; }
void setup() {}
void loop() {
  left.ticks += 500;
  left.rpm = 7;
  sum.add(30);
  move(&position);
  fill(ring, 4);
  raise(level);
  tone(8, left.ticks + sum.total + position + limit + ring[1] + *shown);
}
