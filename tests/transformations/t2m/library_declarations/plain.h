#ifndef PLAIN_H
#define PLAIN_H
#include <Arduino.h>
#include "nowhere/to_be_found.h"

#define PLAIN_VERSION "1.2"  // a text
#define PLAIN_ADDRESS 0x40
#define PLAIN_LIMIT   (-1.5e3f)
#define PLAIN_WIDE ((uint8_t)   5)
#define PLAIN_SUM (PLAIN_ADDRESS + 1)
#define PLAIN_MAX(a, b) ((a) > (b) ? (a) : (b))

enum PlainMode { PLAIN_OFF, PLAIN_ON = 3, PLAIN_LAST = (1 << 2) };
typedef enum { ONE, TWO } plain_count_t;
enum class Strong : uint8_t { A, B };
enum { NAMELESS };

typedef void (*plain_callback)(int, void *);
typedef struct { int x, y; } plain_point;

/* class InAComment { public: void no(); }; */
class Plain : public Print, protected Stream<int, 4> {
public:
  Plain();
  explicit Plain(uint8_t pin, const char *name = ",)", bool fast=true) : _pin(pin), _table{1, 2} { begin(); }
  Plain(const Plain &) = delete;
  virtual ~Plain() {}
  bool begin(TwoWire * wire = & Wire);
  virtual size_t write(uint8_t) override;
  float read(void) const { if (_pin) { return 1; } return 0; }
  static int instances();
  static constexpr uint8_t Size = 4;
  uint16_t color(byte r, byte g, byte b), *line(int y), last();
  const char* name() const noexcept;
  auto later() -> unsigned long;
  void on(void (* callback)(int, char *), plain_callback other);
  operator bool() const;
  Plain & operator += (int n);
  uint8_t operator[](size_t i);
  void operator()(int) ;
  template <typename T, size_t N = (1 > 0)> void all(const T (&values)[N]);
  [[deprecated("use read")]] float get() __attribute__((deprecated));
  virtual void pure() = 0;
  struct Inner { void inside(); int a; };
  enum Level { LOW_LEVEL, HIGH_LEVEL };
  uint8_t bits : 3;
  void (*pointer)(int);
  friend bool operator==(const Plain &a, const Plain &b) { return true; }
  friend class Other;
protected:
  void hidden();
private:
  int secret();
  enum Private { NO };
  struct Closed { void no(); };
  int _pin, _table[2];
};

struct Only { int data; };
struct Doing { void run(); private: void no(); };
class Forward;
extern Plain plain;
Plain other(5);
static const int values[] = { 1, 2, 3 };
int sum(const int *values, unsigned n = 3);
inline float half(float x) { return x / 2; }
void Plain::hidden() { }
ISR(TIMER1_vect) { tick(); }
DECLARE_THING(x)
unsigned long after_macro();
#endif
