/**
 * What all owners of Bladesmith's C++ interface share: exceptions, views of arrays, handles. Included
 * by bladesmith.hpp.
 */
#ifndef BLADESMITH_CORE_HPP
#define BLADESMITH_CORE_HPP

#include <bladesmith/bladesmith.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace bladesmith {

/** What every function here throws. */
class Error : public std::runtime_error {
public:
    Error(std::int32_t status, const std::string &message) : std::runtime_error(message), status_(status) {}

    /** One of bladesmith_status: BLADESMITH_STATUS_CANCELLED, BLADESMITH_STATUS_MISMATCH ... */
    std::int32_t status() const noexcept { return status_; }

private:
    std::int32_t status_;
};

/** Values in a row that somebody else owns: a vector, an array, or pointer and number. */
template <class T> class View {
public:
    View() = default;
    View(const T *data, std::size_t size) : data_(data), size_(size) {}
    /** Views a container with data() and size(), which must outlive the call it is passed to. */
    template <class C, class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<const C &>().data()), const T *>>>
    View(const C &values) : data_(values.data()), size_(values.size()) {}
    template <std::size_t N> View(const T (&values)[N]) : data_(values), size_(N) {}

    const T *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }

private:
    const T *data_ = nullptr;
    std::size_t size_ = 0;
};

namespace detail {

inline void check(std::int32_t status)
{
    if (status != BLADESMITH_STATUS_OK)
        throw Error(status, bladesmith_last_error());
}

[[noreturn]] inline void refuse(const std::string &why)
{
    throw Error(BLADESMITH_STATUS_ARGUMENT, why);
}

/** How many points of so many numbers there are in an array. */
inline std::size_t points_in(View<double> values, std::size_t each, const char *name)
{
    if (values.size() % each != 0)
        refuse(std::string(name) + " needs " + std::to_string(each) + " numbers a point, not " +
               std::to_string(values.size()) + " in all");
    return values.size() / each;
}

/** Refuses an array of another length. */
inline void require(View<double> values, std::size_t count, const char *name)
{
    if (values.size() != count)
        refuse(std::string(name) + " needs " + std::to_string(count) + " numbers, not " + std::to_string(values.size()));
}

/** Owns one handle, which Free gives back. */
template <class T, void (*Free)(T *)> class Handle {
public:
    /** The handle for calls of bladesmith.h; still owned here. */
    const T *get() const noexcept { return handle_.get(); }

protected:
    /** Takes what `make(T **out)` returns; throws what its status says. */
    template <class Make> explicit Handle(Make make)
    {
        if (bladesmith_abi_version() != BLADESMITH_ABI_VERSION)
            throw Error(BLADESMITH_STATUS_INTERNAL,
                        "the library of Bladesmith has C interface " + std::to_string(bladesmith_abi_version()) +
                            ", this program was compiled for " + std::to_string(BLADESMITH_ABI_VERSION) +
                            ": install both from one release");
        T *made = nullptr;
        check(make(&made));
        handle_.reset(made);
    }

    /** Takes a handle that a call gave out beside others. */
    explicit Handle(T *made) noexcept : handle_(made) {}

    /** The text that `call(handle, buffer, capacity, length)` gives. */
    template <class Call> std::string text(Call call) const
    {
        std::size_t length = 0;
        check(call(get(), nullptr, 0, &length));
        std::string out(length + 1, '\0');
        check(call(get(), out.data(), out.size(), &length));
        out.resize(length);
        return out;
    }

private:
    struct Deleter {
        void operator()(T *handle) const noexcept { Free(handle); }
    };
    std::unique_ptr<T, Deleter> handle_;
};

} // namespace detail

} // namespace bladesmith

#endif
