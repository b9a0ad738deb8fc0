#include "shader/vulkan.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#if __has_include(<vulkan/vulkan.h>)
#include <vulkan/vulkan.h>

namespace gonio::test {
namespace {

void must(VkResult result, const char* doing) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string(doing) + ": VkResult " + std::to_string(result));
}

class Device final : public Vulkan {
 public:
  Device(VkInstance instance, VkPhysicalDevice physical)
      : instance_(instance), physical_(physical) {
    VkPhysicalDeviceVulkan12Features half{};
    half.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    half.shaderFloat16 = VK_TRUE;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &half;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    must(vkCreateDevice(physical_, &info, nullptr, &device_), "opening the device");
    vkGetDeviceQueue(device_, 0, 0, &queue_);
  }
  ~Device() override {
    vkDestroyDevice(device_, nullptr);
    vkDestroyInstance(instance_, nullptr);
  }
  std::string device() const override {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    return properties.deviceName;
  }
  std::vector<float> run(std::span<const std::uint32_t> spirv,
                         std::span<const float> inputs,
                         std::size_t invocations,
                         std::size_t outputs) override {
    std::array<Buffer, 2> buffers{buffer(inputs.size_bytes()), buffer(outputs * sizeof(float))};
    std::memcpy(buffers[0].at, inputs.data(), inputs.size_bytes());

    std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i)
      bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout_info.bindingCount = 2;
    layout_info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout;
    must(vkCreateDescriptorSetLayout(device_, &layout_info, nullptr, &set_layout), "set layout");
    VkPipelineLayoutCreateInfo pipeline_layout_info{};
    pipeline_layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    pipeline_layout_info.setLayoutCount = 1;
    pipeline_layout_info.pSetLayouts = &set_layout;
    VkPipelineLayout layout;
    must(vkCreatePipelineLayout(device_, &pipeline_layout_info, nullptr, &layout), "layout");
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    VkShaderModule module;
    must(vkCreateShaderModule(device_, &module_info, nullptr, &module), "shader");
    VkComputePipelineCreateInfo pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline_info.stage.module = module;
    pipeline_info.stage.pName = "main";
    pipeline_info.layout = layout;
    VkPipeline pipeline;
    must(vkCreateComputePipelines(device_, nullptr, 1, &pipeline_info, nullptr, &pipeline),
         "pipeline");

    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool;
    must(vkCreateDescriptorPool(device_, &pool_info, nullptr, &pool), "descriptors");
    VkDescriptorSetAllocateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set_info.descriptorPool = pool;
    set_info.descriptorSetCount = 1;
    set_info.pSetLayouts = &set_layout;
    VkDescriptorSet set;
    must(vkAllocateDescriptorSets(device_, &set_info, &set), "descriptor set");
    for (std::uint32_t i = 0; i < buffers.size(); ++i) {
      const VkDescriptorBufferInfo whole{buffers[i].buffer, 0, VK_WHOLE_SIZE};
      VkWriteDescriptorSet write{};
      write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      write.dstSet = set;
      write.dstBinding = i;
      write.descriptorCount = 1;
      write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      write.pBufferInfo = &whole;
      vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    }

    VkCommandPoolCreateInfo commands_info{};
    commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    VkCommandPool commands;
    must(vkCreateCommandPool(device_, &commands_info, nullptr, &commands), "commands");
    VkCommandBufferAllocateInfo command_info{};
    command_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    command_info.commandPool = commands;
    command_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    command_info.commandBufferCount = 1;
    VkCommandBuffer command;
    must(vkAllocateCommandBuffers(device_, &command_info, &command), "command");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    must(vkBeginCommandBuffer(command, &begin), "recording");
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(command, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0,
                            nullptr);
    vkCmdDispatch(command, static_cast<std::uint32_t>(invocations / 64), 1, 1);
    must(vkEndCommandBuffer(command), "recorded");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &command;
    must(vkQueueSubmit(queue_, 1, &submit, nullptr), "submitting");
    must(vkQueueWaitIdle(queue_), "running");

    std::vector<float> result(outputs);
    std::memcpy(result.data(), buffers[1].at, outputs * sizeof(float));
    vkDestroyCommandPool(device_, commands, nullptr);
    vkDestroyDescriptorPool(device_, pool, nullptr);
    vkDestroyPipeline(device_, pipeline, nullptr);
    vkDestroyShaderModule(device_, module, nullptr);
    vkDestroyPipelineLayout(device_, layout, nullptr);
    vkDestroyDescriptorSetLayout(device_, set_layout, nullptr);
    for (const auto& b : buffers) {
      vkDestroyBuffer(device_, b.buffer, nullptr);
      vkFreeMemory(device_, b.memory, nullptr);
    }
    return result;
  }

 private:
  struct Buffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
    void* at;
  };
  Buffer buffer(std::size_t bytes) {
    Buffer b;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = std::max<std::size_t>(bytes, 4);
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    must(vkCreateBuffer(device_, &info, nullptr, &b.buffer), "buffer");
    VkMemoryRequirements needed;
    vkGetBufferMemoryRequirements(device_, b.buffer, &needed);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    constexpr auto shared =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    std::uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           !((needed.memoryTypeBits >> type & 1) != 0 &&
             (memory.memoryTypes[type].propertyFlags & shared) == shared))
      ++type;
    VkMemoryAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needed.size;
    allocation.memoryTypeIndex = type;
    must(vkAllocateMemory(device_, &allocation, nullptr, &b.memory), "memory");
    must(vkBindBufferMemory(device_, b.buffer, b.memory, 0), "binding");
    must(vkMapMemory(device_, b.memory, 0, VK_WHOLE_SIZE, 0, &b.at), "mapping");
    return b;
  }

  VkInstance instance_;
  VkPhysicalDevice physical_;
  VkDevice device_ = nullptr;
  VkQueue queue_ = nullptr;
};

}  // namespace

std::unique_ptr<Vulkan> Vulkan::open(std::string& why) {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance;
  if (vkCreateInstance(&info, nullptr, &instance) != VK_SUCCESS) {
    why = "no driver of Vulkan";
    return nullptr;
  }
  std::uint32_t count = 1;
  VkPhysicalDevice physical;
  vkEnumeratePhysicalDevices(instance, &count, &physical);
  VkPhysicalDeviceVulkan12Features features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceFeatures2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  all.pNext = &features;
  if (count > 0) vkGetPhysicalDeviceFeatures2(physical, &all);
  if (count == 0 || !features.shaderFloat16) {
    vkDestroyInstance(instance, nullptr);
    why = "no Vulkan device with halves";
    return nullptr;
  }
  return std::make_unique<Device>(instance, physical);
}

}  // namespace gonio::test

#else

namespace gonio::test {
std::unique_ptr<Vulkan> Vulkan::open(std::string& why) {
  why = "built without Vulkan's headers";
  return nullptr;
}
}  // namespace gonio::test

#endif
