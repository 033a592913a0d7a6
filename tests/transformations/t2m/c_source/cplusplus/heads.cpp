// Heads of statements that C does not have.
void high(int pin);
void low(int pin);
int get(void);
int values[3] = {1, 2, 3};
int matrix[2][3];

void loops(void) {
  for (int v : values) high(v);
  for (const auto &v : values) { low(v); }
  for (auto &row : matrix)
    for (int cell : row) high(cell);
  for (int n = get(); int v : values) low(v + n);
  while (int w = get()) low(w);
  for (int i = 0; int k = get(); i++) low(k + i);
  for (int i = 0; i < 3; i++) high(values[i]);
}

void branches(int a) {
  if (int q = get(); q > 2) low(q);
  if (a = get(); a) { high(a); } else low(a);
  if (int q = get()) low(q); else high(q);
  if constexpr (sizeof(int) == 4) high(1);
  if (; a) high(a);
  switch (int s = get(); s) { case 1: high(s); break; default: low(s); }
  switch (int s = get()) { case 2: high(s); }
}

void thrown(void) {
  try { high(get()); } catch (int e) { low(e); } catch (...) { low(9); }
}

int tried(int a) try { high(a); return 1; } catch (...) { return 2; }

struct Sum {
  int operator()(int a) const { return a; }
};

void called(const Sum &sum) {
  auto f = [](int a) { return a; };
  f(3);
  sum(get());
}
