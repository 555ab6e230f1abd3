FROM aisle:build
RUN cmake --preset release -DAISLE_TESTS=ON -DCMAKE_CXX_COMPILER_LAUNCHER= -DCMAKE_C_COMPILER_LAUNCHER= \
 && cmake --build --preset release
