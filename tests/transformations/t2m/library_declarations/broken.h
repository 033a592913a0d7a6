class Open { public: void first(); void second(
class Next { public: void lost(); };
}}} ) ] > ;
#endif
#else
int found();
template <
