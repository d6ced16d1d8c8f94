#pragma once
// Queues of what is kept for each stretch of a route.

#include <boost/container/deque.hpp>

namespace motion {

/// std::deque allocates each element of more than 256 bytes for itself; here 32 lie together.
template <class Element>
using StretchQueue =
    boost::container::deque<Element, void,
                            boost::container::deque_options_t<boost::container::block_size<32U>>>;

} // namespace motion
