#define LAMP(n) do { high(n); pause(100); low(n); } while (0)
