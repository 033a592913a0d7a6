static void high(int n) { (void)n; }
