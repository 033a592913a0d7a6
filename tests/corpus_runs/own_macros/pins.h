#define P 5
#define Q (P+1)
#define HI high(3)
