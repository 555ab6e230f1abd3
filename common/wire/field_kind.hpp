#pragma once
#include <type_traits>
#include <utility>

namespace aisle::wire {

/// Is it a bounded string of the IDL?
template <class Field, class = void>
struct IsText : std::false_type {};
template <class Field>
struct IsText<Field, std::void_t<decltype(std::declval<const Field&>().to_string())>> : std::true_type {};

/// Is it a sequence or an array of the IDL?
template <class Field, class = void>
struct IsSequence : std::false_type {};
template <class Field>
struct IsSequence<Field, std::void_t<decltype(std::declval<const Field&>().begin())>> : std::true_type {};

}  // namespace aisle::wire
