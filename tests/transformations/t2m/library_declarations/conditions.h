#pragma once
#if defined(__AVR__)
#define SIZE 1
#elif defined(ESP32)
#define SIZE 2
#endif
#if 0
void never();
#define NEVER 1
#else
void instead();
#endif
#ifdef __cplusplus
extern "C" {
#endif
void from_c(int);
#ifdef __cplusplus
}
#endif
namespace outer { inline namespace inner {
class Two
#if defined(A)
 : public First
#else
 : public Second
#endif
{
  void closed();
 public:
#if defined(A)
  void both(int a);
#else
  void both(long a);
#endif
#ifdef B
  void body(int a) {
#else
  void body(long a) {
#endif
    start();
  }
 signals:
  void changed();
 public slots:
  void slot();
};
}}
class __attribute__((packed)) API_EXPORT Packed final : public outer::Two {
 public:
  void behind();
};
END_HERE
BEGIN_HERE
class Marked { public: static struct item *first(); };
static const struct { int a; } table = { 1 };
API_EXPORT enum Marks { M1, M2 };
extern "C" int alone(void);
#ifdef NEVER_CLOSED
int at_the_end();
